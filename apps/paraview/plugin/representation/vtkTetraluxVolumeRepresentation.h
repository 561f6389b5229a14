// SPDX-License-Identifier: Apache-2.0
/**
 * @class vtkTetraluxVolumeRepresentation
 * @brief unstructured grids by vtkTetraluxMapper, serial and in parallel
 *
 * In parallel ParaView cuts space into boxes, one a process, and hands each process all cells that reach into its box.
 * Rays are cut at the box, so that pictures of the processes, blended in the order of the boxes, are the whole.
 */
#ifndef vtkTetraluxVolumeRepresentation_h
#define vtkTetraluxVolumeRepresentation_h

#include "vtkNew.h"                           // for the mapper
#include "vtkTetraluxRepresentationModule.h"  // for the export macro
#include "vtkUnstructuredGridVolumeRepresentation.h"

class vtkPlane;
class vtkRenderer;
class vtkTetraluxMapper;
class vtkTextActor;

class VTKTETRALUXREPRESENTATION_EXPORT vtkTetraluxVolumeRepresentation
    : public vtkUnstructuredGridVolumeRepresentation {
public:
    static vtkTetraluxVolumeRepresentation* New();
    vtkTypeMacro(vtkTetraluxVolumeRepresentation, vtkUnstructuredGridVolumeRepresentation);
    void PrintSelf(ostream& os, vtkIndent indent) override;

    /// There is one mapper: the inherited choice among mappers is not looked at.
    void SetActiveVolumeMapper(const char*) override;
    int ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* in, vtkInformation* out) override;

    ///@{
    /// Those of vtkTetraluxMapper.
    void SetBlendMode(int mode);
    void SetScaleInvariant(int on);
    void SetOpacityIsAlpha(int on);
    void SetSilhouettes(int which);
    void SetSamples(int samples);
    void SetThreads(int threads);
    ///@}

    ///@{
    /// A plane, in the coordinates of the view, that shows the side to which its normal points. Off.
    void SetClip(int on);
    void SetClipOrigin(double x, double y, double z);
    void SetClipNormal(double x, double y, double z);
    ///@}

    /// So many pixels of each whole picture are verified (vtkTetraluxMapper::VerifyLastImage), and the view tells their
    /// rmse.
    void SetVerify(int pixels);

protected:
    vtkTetraluxVolumeRepresentation();
    ~vtkTetraluxVolumeRepresentation() override;
    bool AddToView(vtkView* view) override;
    bool RemoveFromView(vtkView* view) override;

private:
    vtkTetraluxVolumeRepresentation(const vtkTetraluxVolumeRepresentation&) = delete;
    void operator=(const vtkTetraluxVolumeRepresentation&) = delete;

    void AllotTime(vtkInformation* in);
    void CutAtBox(vtkInformation* in);
    void TellError();

    vtkNew<vtkTetraluxMapper> Mapper;
    vtkNew<vtkPlane> ClipPlane;
    int Verify = 0;
    vtkNew<vtkTextActor> Error;
    vtkRenderer* Renderer = nullptr;
};
#endif
