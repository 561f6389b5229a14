// SPDX-License-Identifier: Apache-2.0
/**
 * @class vtkTetraluxMapper
 * @brief volumes of unstructured grids in exact order, with pre-integration
 *
 * Draws all solid cells of an unstructured grid (linear, curved, polyhedra; those that are duplicate or hidden ghosts
 * left out) by Tetralux, into any window of VTK, before and behind opaque geometry. Scalars of points or cells as
 * SetScalarMode and SelectScalarArray say; of vectors the magnitude or the component that the colour function says.
 *
 * Of vtkVolumeProperty count colours (or gray), scalar opacity, its unit distance d, and Shade with ambient, diffuse,
 * specular and specular power. Opacity o(s) is what VTK's other mappers of unstructured grids take it for, the
 * extinction o/d; with OpacityIsAlpha it is the opacity of a piece of length d, the extinction −ln(1 − o)/d.
 * Gradient opacity is not looked at, as in those mappers; dependent components are refused with an error.
 *
 * The mapper's clipping planes, the volume's matrix and every camera of VTK that does not mirror count, but not the
 * near plane of a perspective view: all that lies before the eye is drawn. When a frame is interactive
 * (vtkProp::GetAllocatedRenderTime below 5 s) and would take longer than it may, it is coarser. A render window's
 * AbortCheckEvent stops a frame, which then shows no volume.
 */
#ifndef vtkTetraluxMapper_h
#define vtkTetraluxMapper_h

#include "vtkTetraluxVolumeModule.h"  // for the export macro
#include "vtkUnstructuredGridVolumeMapper.h"

#include <memory>  // for what is not public

class vtkImageData;

class VTKTETRALUXVOLUME_EXPORT vtkTetraluxMapper : public vtkUnstructuredGridVolumeMapper {
public:
    static vtkTetraluxMapper* New();
    vtkTypeMacro(vtkTetraluxMapper, vtkUnstructuredGridVolumeMapper);
    void PrintSelf(ostream& os, vtkIndent indent) override;

    /// Ways to blend besides the superclass's, with the numbers of vtkVolumeMapper.
    enum { MINIMUM_INTENSITY_BLEND = 2, AVERAGE_INTENSITY_BLEND = 3, ADDITIVE_BLEND = 4, ISOSURFACE_BLEND = 5 };
    void SetBlendModeToMinimumIntensity() { this->SetBlendMode(MINIMUM_INTENSITY_BLEND); }
    void SetBlendModeToAverageIntensity() { this->SetBlendMode(AVERAGE_INTENSITY_BLEND); }
    void SetBlendModeToAdditive() { this->SetBlendMode(ADDITIVE_BLEND); }
    /// At vtkVolumeProperty::GetIsoSurfaceValues(), with the opacity and colour of the value.
    void SetBlendModeToIsoSurface() { this->SetBlendMode(ISOSURFACE_BLEND); }

    ///@{
    /// Opacity counts per change of the scalar instead of per length (Kraus 2005), in composite and additive blending.
    /// The unit distance then is as large a share of the scalar's range as it is of the grid's diagonal. Off.
    vtkSetMacro(ScaleInvariant, vtkTypeBool);
    vtkGetMacro(ScaleInvariant, vtkTypeBool);
    vtkBooleanMacro(ScaleInvariant, vtkTypeBool);
    ///@}

    ///@{
    /// Whether the opacity function is that of a piece of the unit distance's length. Off.
    vtkSetMacro(OpacityIsAlpha, vtkTypeBool);
    vtkGetMacro(OpacityIsAlpha, vtkTypeBool);
    vtkBooleanMacro(OpacityIsAlpha, vtkTypeBool);
    ///@}

    enum { SILHOUETTES_NONE = 0, SILHOUETTES_EXACT = 1, SILHOUETTES_APPROXIMATE = 2 };
    ///@{
    /// Whether thin layers become denser where they are seen edge-on (Kraus 2005, Equations 15 to 17). None.
    vtkSetClampMacro(Silhouettes, int, SILHOUETTES_NONE, SILHOUETTES_APPROXIMATE);
    vtkGetMacro(Silhouettes, int);
    ///@}

    ///@{
    /// Rays for each pixel, 1 to 64: anti-aliasing. 1.
    vtkSetClampMacro(Samples, int, 1, 64);
    vtkGetMacro(Samples, int);
    ///@}

    ///@{
    /// "auto", "cpu", "gl" or "reference".
    vtkSetStdStringFromCharMacro(Engine);
    vtkGetCharFromStdStringMacro(Engine);
    ///@}

    ///@{
    /// Threads that draw; 0: as many as the machine has.
    vtkSetClampMacro(Threads, int, 0, 1024);
    vtkGetMacro(Threads, int);
    ///@}

    ///@{
    /// Only what lies within this box (x0, x1, y0, y1, z0, z1; world coordinates) is drawn, every ray cut at it. A box
    /// without extent, the default: everything. For parts of a scene that are drawn by several processes.
    vtkSetVector6Macro(Region, double);
    vtkGetVector6Macro(Region, double);
    ///@}

    /// The last frame's picture of the volume alone: float RGBA, premultiplied, the lower left pixel first. Empty
    /// before the first frame.
    vtkImageData* GetLastImage();

    /// Computes so many pixels of the last frame again in double precision. \return rmse over RGBA of these
    /// pixels; negative, with an error, when there is no frame to verify.
    double VerifyLastImage(int pixels);

    /// Where pixel (x, y) of the last frame, the lower left one being (0, 0), first shows anything. \return whether it
    /// shows something.
    bool PickPosition(int x, int y, double position[3]);
    /// The scalar there; NaN where nothing shows.
    double PickScalar(int x, int y);

    ///@{
    /// Of the last frame: tetrahedra drawn, time of the engine (milliseconds, what was made anew included), whether it
    /// was drawn to its end, its size in pixels before it was enlarged, pixels that show something opaque of VTK's, and
    /// how often the mesh and the field were made.
    vtkGetMacro(CellsDrawn, vtkIdType);
    vtkGetMacro(EngineMilliseconds, double);
    vtkGetMacro(Complete, bool);
    vtkGetVector2Macro(DrawnSize, int);
    vtkGetMacro(OpaquePixels, vtkIdType);
    vtkGetMacro(MeshesMade, int);
    vtkGetMacro(FieldsMade, int);
    ///@}

    void Render(vtkRenderer* renderer, vtkVolume* volume) override;
    void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
    vtkTetraluxMapper();
    ~vtkTetraluxMapper() override;

    vtkTypeBool ScaleInvariant = 0;
    vtkTypeBool OpacityIsAlpha = 0;
    int Silhouettes = SILHOUETTES_NONE;
    int Samples = 1;
    std::string Engine = "auto";
    int Threads = 0;
    double Region[6] = {0, 0, 0, 0, 0, 0};

    vtkIdType CellsDrawn = 0;
    double EngineMilliseconds = 0;
    bool Complete = false;
    int DrawnSize[2] = {0, 0};
    vtkIdType OpaquePixels = 0;
    int MeshesMade = 0;
    int FieldsMade = 0;

private:
    vtkTetraluxMapper(const vtkTetraluxMapper&) = delete;
    void operator=(const vtkTetraluxMapper&) = delete;

    void Draw(vtkRenderer* renderer, vtkVolume* volume);

    struct Internals;
    std::unique_ptr<Internals> Own;
};
#endif
